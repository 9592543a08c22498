//! Headings in Turkish, Portuguese and Chinese: a second part of the table of `headings`.

use super::columns::Column;

/// The headings of a column: Turkish, Portuguese, Chinese; `|` between two.
#[rustfmt::skip]
pub(super) const MORE_HEADINGS: &[(Column, [&str; 3])] = &[
    (Column::Id, ["Demirbaş No|Demirbaş|Envanter No|Sicil No|Kod|Sıra No|No|Seri No", "Nº de inventário|Nº inventário|Nº de patrimônio|Nº patrimônio|Patrimônio|Inventário|Código|Nº de série",
        "编号|資產編號|资产编号|序号|设备编号|設備編號|代码"]),
    (Column::Item, ["Tanım|Ekipman|Cihaz|Cihaz adı|Malzeme|Açıklama|Ad|Adı|Eşya|Nesne", "Descrição|Item|Objeto|Equipamento|Nome|Designação", "名称|名稱|设备名称|設備名稱|物品|描述|品名"]),
    (Column::Quantity, ["Adet|Miktar|Sayı|Sayısı", "Quantidade|Qtd|Qtde|Quant", "数量|數量|台数|件数"]),
    (Column::Location, ["Yer|Konum|Bölüm|Birim|Servis", "Localização|Local|Setor|Departamento", "位置|地点|科室|部门"]),
    (Column::Building, ["Bina|Blok", "Edifício|Prédio|Bloco", "建筑|楼栋|大楼"]),
    (Column::Floor, ["Kat|Kat No", "Andar|Piso|Pavimento", "楼层|樓層|层|所在楼层"]),
    (Column::Room, ["Oda|Oda No|Mahal", "Sala|Quarto|Compartimento", "房间|房間|房号|室"]),
    (Column::Height, ["Yükseklik|Boy|Yük.", "Altura|Alt.", "高度|高"]),
    (Column::Thickness, ["Derinlik|Der.|Kalınlık", "Profundidade|Prof.|Espessura", "深度|深|厚度"]),
    (Column::Width, ["Genişlik|En|Uzunluk|Gen.", "Largura|Larg.|Comprimento", "宽度|寬度|宽|长度"]),
    (Column::Mass, ["Ağırlık|Kütle|Ağ.", "Peso|Massa", "重量|质量|質量"]),
    (Column::CgHeight, ["Ağırlık merkezi yüksekliği|Ağırlık merkezi", "Altura do centro de gravidade|Centro de gravidade", "重心高度|重心"]),
    (Column::Anchored, ["Sabit mi|Sabit|Sabitlenmiş|Sabitlenmiş mi|Sabitli mi|Ankrajlı|Ankraj|Bağlı", "Fixado|Ancorado|Fixo|Aparafusado|Fixação", "固定|是否固定|锚固"]),
    (Column::Casters, ["Tekerlek|Tekerlekli|Tekerlekler|Teker", "Rodas|Rodízios|Rodinhas", "轮子|脚轮|輪子"]),
    (Column::RestsOn, ["Ayak|Ayaklar|Taban|Zemin", "Pés|Apoio|Base", "支脚|底座"]),
    (Column::WallGap, ["Duvara mesafe|Duvar mesafesi|Duvara uzaklık", "Distância à parede|Distância da parede", "离墙距离|与墙距离|距墙"]),
    (Column::Clearance, ["Boşluk|Serbest mesafe", "Espaço livre", "净距"]),
    (Column::Tolerance, ["İzin verilen ivme|Dayanım", "Aceleração admissível|Choque admissível", "允许加速度|容许加速度"]),
    (Column::Priority, ["Öncelik", "Prioridade", "优先级"]),
    (Column::Notes, ["Not|Notlar|Açıklamalar|Düşünceler", "Notas|Observações|Obs.|Comentários", "备注|備註|说明"]),
    (Column::Dimensions, ["Boyut|Boyutlar|Ölçü|Ölçüler|Ebat", "Dimensões|Medidas|Tamanho", "尺寸|规格|外形尺寸"]),
    (Column::Shape, ["Şekil|Biçim", "Forma|Formato", "形状"]),
    (Column::Diameter, ["Çap", "Diâmetro", "直径|直徑"]),
    (Column::Unit, ["Ölçü birimi|Birimi", "Unidade|Unidade de medida", "单位|單位"]),
];
